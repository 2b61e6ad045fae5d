"""Colours of Okabe and Ito, which colour-blind readers can tell apart."""

BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY, BLACK = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#000000")


if __name__ == "__main__":
    raise SystemExit("slipscale.pictures.colours is a library, no command: slipscale -h lists the commands.")
