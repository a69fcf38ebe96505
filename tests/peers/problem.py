"""The error of bad input or of a renderer that fails: one line for the user, no traceback."""


class Problem(Exception):
    pass
