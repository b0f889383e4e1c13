"""The routes, one file per subject. A route checks the shape, calls one service, and answers."""
