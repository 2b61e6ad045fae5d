#!/usr/bin/env bash
# A study as an array of jobs: one makes what its runs share, an array makes the runs, one collects them.
#   runs/profiles/slurm/array.sh [-n CORES] [-t MINUTES] [-r RULE] TASKS SNAKEFILE [words for snakemake ...]
# -n: of each task, at least the ranks of a run (1); -t: of each job (60); -r: the rule of the runs (slide).
# After a failure, or when the time was too short: the same again; what is missing is run, and what was stopped goes on.
set -euo pipefail
cores=1 minutes=60 rule=slide
while getopts n:t:r: option; do
  case $option in
    n) cores=$OPTARG ;;
    t) minutes=$OPTARG ;;
    r) rule=$OPTARG ;;
    *) exit 2 ;;
  esac
done
shift $((OPTIND - 1))
if [ $# -lt 2 ]; then
  sed -n '2,5s/^# //p' "$0" >&2
  exit 2
fi
if ! [ -f "$2" ]; then
  echo "array.sh: there is no $2" >&2
  exit 2
fi
tasks=$1 snakefile=$(realpath "$2")
study=$(basename "$(dirname "$snakefile")")
shift 2
mkdir -p out/slurm
export SBATCH_MEM_PER_CPU=${SBATCH_MEM_PER_CPU:-2000}

submit() { # submit NAME sbatch-options ... -- words for snakemake ...
  local name=$1 options=()
  shift
  while [ "$1" != -- ]; do
    options+=("$1")
    shift
  done
  shift
  sbatch --parsable --kill-on-invalid-dep=yes --time="$minutes" --job-name="$study-$name" \
    --output="$PWD/out/slurm/%x-%j.log" "${options[@]}" --wrap="exec snakemake ${*@Q}"
}

# No lock: the tasks work side by side, each on outputs of its own.
common=(--snakefile "$snakefile" --nolock --rerun-incomplete --keep-going --latency-wait 60 "$@")
shared=$(submit shared -- part "${common[@]}" --cores 1 --omit-from "$rule")
runs=$(submit runs --array="1-$tasks" --output="$PWD/out/slurm/%x-%A_%a.log" --ntasks="$cores" --signal=USR1@60 \
  --dependency="afterok:$shared" -- part "${common[@]}" --cores "$cores")
table=$(submit table --dependency="afterok:$runs" -- "${common[@]}" --cores 1)
echo "jobs $shared (what the runs share), $runs (the runs, $tasks tasks), $table (the table); they write to out/slurm"
