"""Documents as PDF; the only user of reportlab."""
