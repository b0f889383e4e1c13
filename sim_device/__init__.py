"""The drive unit: its firmware, the physics around it, and both as a simulated unit."""
