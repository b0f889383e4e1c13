"""Use cases, one verb each: connect, tune, calibrate, record, review, upload."""
