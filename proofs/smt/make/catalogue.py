"""All statements."""

from importlib import import_module

NOTIONS = ["parallel_sum", "riccati", "stability", "updates", "enclosures", "others", "floats"]


def files():
    """The text of every file by its path below proofs/smt."""
    return dict(
        file
        for notion in NOTIONS
        for statement in import_module(f".{notion}", __package__).statements()
        for file in statement.files()
    )
