"""What goes in and out over HTTP, one file per subject. The browser's types come from here."""
