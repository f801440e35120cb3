"""The command line: the commands, and what people are told."""
