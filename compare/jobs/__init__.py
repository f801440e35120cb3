"""What each command does between its question and its page, one job a module."""
