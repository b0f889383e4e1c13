"""Who may do what: permissions, roles, the rule for passwords, and patience with wrong ones."""
