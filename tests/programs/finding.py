"""Rows of the verification table from the tests in Python, as report.hpp prints them from those in C++."""


def report(topic, quantity, expected, found, source, order="-"):
    """What an independent source says and what the program finds; tests/verification/table.py gathers the rows."""
    print()  # behind the dots of unittest
    print("verification", topic, quantity, expected, found, order, source, sep=" | ", flush=True)
