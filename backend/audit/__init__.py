"""Who changed what: the chain of events as people look at it, and take it away."""
