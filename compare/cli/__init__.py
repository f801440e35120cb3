"""The command line: the commands, and the messages that users see."""
