"""Reads what the programs leave in their output folders, measures, compares and plots it. All quantities in SI units.

    PYTHONPATH=runs python3 -m analysis.picture out/first picture.png

Reading         reading (files of a run), mesh (cells, points in cells), effective (of homogenize), comparison (of relocalize)
Measuring       regime (what a run did in a window), spectrum (Welch), distance (of signals, spectra, portraits),
                surface_motion (power through the contact), convergence (orders, Richardson), refined and refinement
                (a sequence of runs), equivalence and morphologies (a block against morphologies), local_history
Adapting        adapt (command), relaxation (formulas), search, trials, adapted (what came of it, for a table)
Running         attempt (a program whose failure is a result), commands (options as words), table (runs by name, rows),
                sequences and families (scenes and meshes of a refinement), sweep, sweep_plan, sweep_command, scales
Saying          report, refinement_report, sweep_report
Pictures        picture (a run at a glance), maps (a table over options), overlay, panels, drawing, and of a study each:
                work_precision, refinement_picture, equivalence_picture, equivalence_map, scatter_picture,
                adapted_picture, relocalized_picture, histories_picture, cell_picture
"""
