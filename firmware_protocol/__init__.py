"""The wire between host and drive unit; depends on nothing of ours."""
