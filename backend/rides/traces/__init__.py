"""A ride as lines: exact min and max per pixel, axes, figures, its track."""
