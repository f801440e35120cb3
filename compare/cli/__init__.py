"""The command line: arguments and options, the commands, and what people are told."""
