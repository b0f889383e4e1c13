"""The only Python that calls C: the law, the simulated unit and the codec through cffi."""
