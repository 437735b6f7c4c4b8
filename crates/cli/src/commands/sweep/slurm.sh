#!/bin/sh
# A part of the sweep in each task of a job array: sbatch slurm.sh
#SBATCH --job-name=edgewalk
#SBATCH --array=0-@LAST@
#SBATCH --cpus-per-task=1
exec @PROGRAM@ sweep run --quiet --out @OUT@
