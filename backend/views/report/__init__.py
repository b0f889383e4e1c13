"""One ride as one HTML file that needs nothing else, to be kept, sent or printed."""
