"""`python -m kuglice`: the command line, where the script itself is not on the path."""

from kuglice.cli import main

if __name__ == "__main__":
    main()
