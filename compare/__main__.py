"""`python -m compare` is the command `crosscheck`."""

from .cli.app import main

if __name__ == "__main__":
    main()
