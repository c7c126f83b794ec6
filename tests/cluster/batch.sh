#!/bin/bash
#SBATCH --ntasks=8 --cpus-per-task=1 --mem-per-cpu=1G --requeue
# The whole experiment as one batch job, which may be requeued: sbatch tests/cluster/batch.sh DEPS=none PROFILE=reduced
# Its stages are steps on the job's own processors; the variables given are make's.
make -j"$SLURM_NTASKS" all RETRY=2 LAUNCH='srun --exact -N1 -n1 -c1 --mem-per-cpu=1G --quit-on-interrupt' "$@"
