"""What every room may know: types and arithmetic without a clock, a file or a port."""
