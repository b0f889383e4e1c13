"""What programs outside Spindle import: a typed client, and a test kit for firmware teams.

A package of its own, so that the names which others import stay when rooms inside move. It imports
the others, and nothing of ours imports it but our tests. The client answers in the API's own types.
"""
