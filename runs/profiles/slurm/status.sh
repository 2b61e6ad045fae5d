#!/bin/sh
# Says for snakemake how a job goes: running, success or failed. Accounting knows, or else the controller, which
# forgets a job some minutes after its end.
state=$(sacct -X -n -P -o State -j "$1" 2>/dev/null | head -1)
if [ -z "$state" ]; then
  said=$(scontrol show job "$1" 2>&1)
  state=$(echo "$said" | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p')
  case $said in *'Invalid job id'*) state=FORGOTTEN ;; esac
fi
case $state in
  COMPLETED) echo success ;;
  '' | PENDING | CONFIGURING | RUNNING | SUSPENDED | COMPLETING | REQUEUE* | RESIZING | STOPPED) echo running ;;
  *) echo failed ;;
esac
