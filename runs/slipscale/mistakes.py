"""What is wrong with what was asked for or found, in one sentence that a command prints before it ends with code 2."""


class Mistake(Exception):
    pass
