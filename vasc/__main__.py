"""``python -m vasc`` is ``vasc``."""

import sys

from vasc.cli import main

if __name__ == "__main__":
    sys.exit(main())
