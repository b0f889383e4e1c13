"""The register: bikes with what they are made of, whose they are, and how they change hands."""
