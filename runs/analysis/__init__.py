"""Reads what `slide` leaves in its output folder, and plots it. All quantities in SI units.

    PYTHONPATH=runs python3 -m analysis.picture out/first picture.png
"""
