"""What programs outside Spindle import: a typed client, and a test kit for firmware teams."""
