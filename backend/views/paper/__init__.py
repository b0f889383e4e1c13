"""Documents as PDF, in vectors, the same bytes for the same content: the one door to reportlab.

Whoever imports a module of this room does so where the document is asked for: reportlab takes
memory and time that a server without a request for paper need not have.
"""
