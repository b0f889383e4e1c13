"""What is asked of an EBL unit, each operation written from top to bottom."""
