"""Log files to samples: FIT and the rest, with salvage; the same bytes are the same ride."""
