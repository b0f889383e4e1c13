"""HTTP without a feature: refusals, safety, who sends a request, the browser's pages."""
