"""`python -m gelatin` is the program `gelatin`."""

from .command import main

if __name__ == "__main__":
    main()
