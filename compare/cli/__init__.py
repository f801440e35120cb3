"""The command line: options from the signatures of compare.commands, progress, completion."""
