"""`python3 -m slipscale` is the command `slipscale`."""

import sys

from slipscale.command import main

sys.exit(main())
