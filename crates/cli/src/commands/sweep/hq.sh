#!/bin/sh
# A part of the sweep in each task of a HyperQueue job; a server and workers are up: sh hq.sh
exec hq submit --name edgewalk --array 0-@LAST@ --cpus 1 -- @PROGRAM@ sweep run --quiet --out @OUT@
