"""One ride as one HTML file."""
