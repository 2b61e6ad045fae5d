"""What is wrong with what was asked for or found, in one sentence that a command prints before it ends with code 2."""


class Mistake(Exception):
    pass


if __name__ == "__main__":
    raise SystemExit("slipscale.mistakes is a library, no command: slipscale -h lists the commands.")
