"""Units that speak EBL, the protocol of firmware_protocol/SPEC.md."""
