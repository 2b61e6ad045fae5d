#!/bin/bash
# Looks at a program from outside: program.sh <base_echo> <ranks> <mpiexec>
# A mistake of the user must give exit code 2 on every rank and one sentence on rank 0, never a dump.
program=$1 ranks=$2 mpiexec=$3
folder=$(mktemp -d) && cd "$folder" || exit 1
trap 'rm -rf "$folder"' EXIT
export HOME=$folder
unset PETSC_OPTIONS PETSC_OPTIONS_YAML
failures=0

run() { # every rank leaves its own exit code in a file; mpiexec itself would end the others after the first
  rm -f codes.*
  "$mpiexec" -n "$ranks" bash -c '"$0" "$@"; echo $? > codes.$OMPI_COMM_WORLD_RANK' \
    "$program" "$@" > out 2> err < /dev/null
}
fail() {
  echo "FAILED: $*"
  sed 's/^/    out: /' out
  sed 's/^/    err: /' err
  failures=$((failures + 1))
  [ $failures -lt 5 ] || exit 1
}

refuses() { # refuses <words of the sentence> <arguments…>
  local words=$1; shift
  run "$@"
  [ "$(cat codes.* | tr -d '\n')" = "$(printf '2%.0s' $(seq "$ranks"))" ] || fail "exit codes $(cat codes.*): $*"
  [ "$(grep -c '^echo: ' err)" = 1 ] || fail "not exactly one sentence: $*"
  grep -qF -- "$words" err || fail "the sentence lacks '$words': $*"
  ! grep -q 'PETSC ERROR\|WARNING!\|what():' out err || fail "a dump: $*"
}
accepts() { # accepts <words of the output> <arguments…>
  local words=$1; shift
  run "$@"
  [ "$(cat codes.* | tr -d '\n')" = "$(printf '0%.0s' $(seq "$ranks"))" ] || fail "exit codes $(cat codes.*): $*"
  grep -qF -- "$words" out || fail "the output lacks '$words': $*"
  [ "$(grep -cF -- "$words" out)" = 1 ] || fail "printed more than once: $*"
  ! grep -q 'PETSC ERROR\|WARNING!\|^echo: ' err || fail "noise: $*"
}
breaks() { # breaks <words of the report> <arguments…>: not a mistake of the user
  local words=$1; shift
  run "$@"
  ! grep -qs 0 codes.* || fail "exit codes $(cat codes.*): $*"
  grep -qF -- "$words" err || fail "the report lacks '$words': $*"
  ! grep -q 'PETSC ERROR\|what():' out err || fail "a dump: $*"
}

# Options
refuses '-wind_speed is not an option of echo; see echo -help' -wind_speed 3
refuses 'did you mean -friction_coefficient?' -fricton_coefficient 0.3
refuses 'did you mean -material_matrix_young?' -material_matrix_yuong 1e9
refuses 'did you mean -material_matrix_young?' -material_martix_young 1e9
refuses 'write -friction_coefficient' -Friction_Coefficient 0.3
refuses 'write -material_Fibre_young' -material_fibre_young 1e9
refuses "'stray' belongs to no option" stray
refuses "'0.4' belongs to no option" -friction_coefficient 0.3 0.4
refuses 'write -friction_coefficient 0.3' -friction_coefficient=0.3
refuses 'write -friction_coefficient 0.3' --friction_coefficient=0.3
refuses 'write -friction_coefficient,' --friction_coefficient 0.3
refuses '-friction_coefficient has no value' -friction_coefficient
refuses '-friction_coefficient has no value' -friction_coefficient -history_every 3
refuses '-friction_coefficient is -0.3, but it must be >= 0 (ratio)' -friction_coefficient -0.3
refuses "-friction_coefficient is '0.3x', but it must be a number >= 0 (ratio)" -friction_coefficient 0.3x
refuses 'did you mean coulomb?' -friction_law coulom
refuses 'did you mean -history_every?' -history 5
refuses 'did you mean -history_every?' -history
[ ! -e 5 ] || fail 'PETSc wrote a log file'
refuses 'nor PETSc has read it' -ksp_rtol 1e-3
refuses 'did you mean -log_view?' -log_veiw
refuses "-log_view is 'mumps'" -log_view mumps
refuses "-options_left is '-1'" -options_left -1
refuses "-fp_trap is 'cg', but it must be true or false" -fp_trap cg
refuses "-malloc_debug is 'aij'" -malloc_debug aij
accepts 'coefficient 0.3' -friction_coefficient 0.3
accepts 'every 7' -run_speed 3 -history_every 7 -no_signal_handler -malloc_debug false
accepts 'young 3e+09' -material_Fibre_young 3e9

# Files
cat > good.yaml <<'YAML'
friction: {coefficient: 0.5, law: coulomb}
material:
  matrix: {young: 1.0e9}
  Fibre:
    young: 2.0e9
history:
  every: 4
  points: [0.0, 1.0, -2.0, 3]
run:
  ranks: 4
  wave_speeds: [1, 2]
  empty:
  mesh: {nodes: 12}
YAML
echo 'history: {every: 9}' > later.yaml
printf 'friction:\n  coefficient: 0.5\n  law coulomb\nhistory: {every: 4}\n' > syntax.yaml
printf 'friction: {coefficient: 0.5\nhistory: {every: 4}\n' > bracket.yaml
printf 'history:\n  points: [[0, 1], [2, 3]]\n' > nested.yaml
printf 'friction: {coefficient: 0.5}\nfriction_coefficient: 0.6\n' > twice.yaml
printf 'friction_coefficient 0.5\n' > prose.yaml
printf 'friction: {coeficient: 0.5}\n' > misspelt.yaml
printf 'history: 5\n' > history.yaml
printf 'friction: {coefficient: }\n' > blank.yaml
printf 'log_view:\n' > late.yaml
printf '$$base: &base {young: 1}\nmaterial: {Fibre: {<<: *base, young: 2}}\n' > merge.yaml
: > empty.yaml
printf 'friction: {coefficient: 0.5}\nfriction: {law: none}\n' > blocks.yaml
printf 'friction: {coefficient: 010}\n' > octal.yaml
printf -- '-wind_speed 3\n' > foreign.txt
printf 'material: {1: {young: 3}}\n' > digits.yaml
printf '# a comment\n1: {young: 3}\n' > number.yaml
printf -- '-friction_coefficient: 0.5\n' > dashes.yaml
printf 'friction:\n\tcoefficient: 0.5\n' > tabs.yaml
accepts 'coefficient 0.5' -options_file_yaml good.yaml
accepts 'young 2e+09' -options_file_yaml good.yaml
accepts 'coefficient 0.7' -options_file_yaml good.yaml -friction_coefficient 0.7
accepts 'coefficient 0.7' -friction_coefficient 0.7 -options_file_yaml good.yaml
accepts 'every 9' -options_file_yaml good.yaml -options_file_yaml later.yaml
accepts 'every 4' -options_file_yaml later.yaml -options_file_yaml good.yaml
accepts 'coefficient 0.25' -options_file_yaml empty.yaml
refuses 'syntax.yaml is not valid YAML near line 3' -options_file_yaml syntax.yaml
refuses 'syntax.yaml is not valid YAML near line 3' -options_file syntax.yaml
refuses 'bracket.yaml is not valid YAML near line 1' -options_file_yaml bracket.yaml
refuses 'nested.yaml has a list inside a list near line 2' -options_file_yaml nested.yaml
refuses 'twice.yaml: friction_coefficient is given twice' -options_file_yaml twice.yaml
refuses 'prose.yaml does not consist of options near line 1' -options_file_yaml prose.yaml
refuses 'did you mean -friction_coefficient?' -options_file_yaml misspelt.yaml
refuses 'did you mean -history_every?' -options_file_yaml history.yaml
refuses '-friction_coefficient has no value' -options_file_yaml blank.yaml
refuses "blocks.yaml gives 'friction' twice near line 2" -options_file_yaml blocks.yaml
refuses '-friction_coefficient is 010, which YAML takes for a number in base 8' -options_file_yaml octal.yaml
refuses 'late.yaml: log_view is read when PETSc starts' -options_file_yaml late.yaml
accepts 'young 2' -options_file_yaml merge.yaml
refuses "names the region '1', which the mesh does not have" -options_file_yaml digits.yaml
refuses 'number.yaml has a name near line 2 (1: {young: 3}) that no option can begin with' -options_file_yaml number.yaml
refuses 'did you mean -friction_coefficient?' -options_file_yaml dashes.yaml
refuses 'tabs.yaml is not valid YAML near line 2' -options_file_yaml tabs.yaml
refuses "cannot read 'absent.yaml'" -options_file_yaml absent.yaml
refuses "cannot read '$folder'" -options_file_yaml "$folder"
refuses "cannot read 'absent.txt'" -options_file absent.txt
refuses "(it stands in 'foreign.txt')" -options_file foreign.txt
refuses '-options_file_yaml has no value' -options_file_yaml
refuses '-options_file_yaml has no value' -options_file_yaml -friction_coefficient 0.3

# The manual, and failures
for help in -h -help --help; do accepts 'Prints what it was told.' $help; done
accepts 'Prints what it was told.' -help -options_file_yaml absent.yaml
[ "$(wc -L < out)" -le 110 ] || fail 'the manual is wider than 110 columns'
grep -q -- '-history_points' out || fail 'the manual lacks an option'
accepts 'PETSc 3.' -version
accepts ', HDF5 1.' -version
accepts 'Summary of Stages' -log_view
refuses 'echo: the mesh has a hole; mend it' -fail user
breaks 'METIS gave up' -fail library
breaks 'More prefixes popped than pushed' -fail petsc
breaks 'an index' -fail other

# Alone, beside others that come and go: nothing of MPI's own lies in a folder that they share.
TMPDIR=$folder/absent "$program" -version > out 2> err < /dev/null || fail 'started alone, needs a session folder'
[ ! -s err ] || fail 'noise: started alone without a temporary folder'

[ $failures = 0 ] && echo 'all as expected'
exit $((failures > 0))
