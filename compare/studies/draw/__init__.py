"""Pictures of one contact: crosscheck draw."""
