"""Reads what the programs leave in their output folders, measures, compares and plots it. All quantities in SI units.

Reading     the files of a run, meshes, effective materials
Measuring   regime (what a run did in a window), spectrum (Welch), distance (of signals, spectra, portraits),
            surface_motion (power through the contact), convergence (orders, Richardson), window. Draws nothing.
Adapting    adapt (command), relaxation (formulas), search, trials
Running     attempt (a program whose failure is a result), commands (options as words), table (runs by name, rows),
            sweep, sweep_plan, sweep_command
Reports     what is said in Markdown about a table
Pictures    picture (a run at a glance), maps (a table over options), cell_picture, relocalized_picture; what they share

What serves one study alone lies beside that study's Snakefile.
"""

import os

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # before h5py: a running job holds its files open
