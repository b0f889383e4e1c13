"""What every judge of the simulation raises."""


class Violation(AssertionError):
    """A safety or liveness property does not hold."""
