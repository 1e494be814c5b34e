"""``python -m photonproof`` is the command line program."""
from .program import main

main()
