# Meshes, effective materials and `slide` runs of a study. Its Snakefile includes this after common.smk and says, in
# functions, what each of them is made of:
#   mesh_options(mesh)            dict of options of `morphology`
#   effective_of(name)            pair: the mesh to homogenise and a dict of options of `homogenize`
#   scene_of(name)                dict: `mesh` (a name, or None where `options` has a mesh_file), `effective` (a name,
#                                 or None), `options` of `slide`, and, where there are some, `ranks` and `files` that
#                                 the run reads besides
# An entry of study.yaml, `limit`, says after how many seconds a program counts as failed.

minutes = -(-int(config["limit"]) // 60) + 2  # that a cluster should grant: a run that takes too long fails by itself


def before_slide(wanted):
    scene = scene_of(wanted.name)
    return {kind: outcome_of(kind, scene[kind]) for kind in ("mesh", "effective") if scene[kind]}


def slide_options(wanted):
    scene = scene_of(wanted.name)
    mesh = {"mesh_file": f"{OUT}/mesh/{scene['mesh']}/mesh.msh"} if scene["mesh"] else {}
    material = {"material_file": f"{OUT}/effective/{scene['effective']}/effective.yaml"} if scene["effective"] else {}
    return words({**mesh, **material, **scene["options"]})


rule mesh:
    input:
        program=PROGRAMS / "morphology"
    output: OUT + "/mesh/{mesh}/outcome.yaml"
    params:
        options=lambda wanted: words(mesh_options(wanted.mesh))
    shell:
        ATTEMPT + " {output:q} --limit {config[limit]} -- {input.program:q} {params.options}"
        ' -output_folder "$(dirname {output:q})"'


rule homogenize:
    input:
        mesh=lambda wanted: outcome_of("mesh", effective_of(wanted.effective)[0]),
        program=PROGRAMS / "homogenize"
    output: OUT + "/effective/{effective}/outcome.yaml"
    params:
        options=lambda wanted: words({"cell_estimate_error": False, **effective_of(wanted.effective)[1]})
    shell:
        ATTEMPT + " {output:q} --after {input.mesh:q} --limit {config[limit]} -- {input.program:q}"
        ' -mesh_file "$(dirname {input.mesh:q})"/mesh.msh {params.options} -output_folder "$(dirname {output:q})"'


# On one rank unless the scene asks for more: a study has runs enough to keep every core busy. The only output that is
# declared is the outcome, so that what a run that was stopped leaves stays, and the next start goes on from there.
rule slide:
    input:
        unpack(before_slide),
        files=lambda run: scene_of(run.name).get("files", []),
        program=PROGRAMS / "slide"
    output: OUT + "/run/{name}/outcome.yaml"
    params:
        set=lambda run: settings(RUNS[run.name]),
        after=lambda run: quoted(before_slide(run).values()),
        mpirun=lambda run: on_ranks(scene_of(run.name).get("ranks", 1)),
        options=slide_options
    threads: lambda run: int(scene_of(run.name).get("ranks", 1))
    retries: GOES_ON
    resources:
        ranks=lambda run: int(scene_of(run.name).get("ranks", 1)),
        runtime=minutes,
        stops=60  # s before its job's limit, with a checkpoint, from which the next job goes on
    shell:
        ATTEMPT + " {output:q} --after {params.after} --limit {config[limit]} --restart {input.program:q}"
        " --set {params.set} --"
        ' {params.mpirun} {input.program:q} {params.options} -output_folder "$(dirname {output:q})"'
