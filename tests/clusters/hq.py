"""Runs the parts of a sweep as a job of HyperQueue: a server and a worker that end with it.

Arguments: the program, the folder of the sweep, the number of parts. Each task finds its part in HQ_TASK_ID.
"""
import sys
from hyperqueue import Job, LocalCluster
program, out, parts = sys.argv[1], sys.argv[2], int(sys.argv[3])
with LocalCluster() as cluster:
    cluster.start_worker()
    client = cluster.client()
    job = Job()
    for _ in range(parts):
        job.program([program, "sweep", "run", "--quiet", "--out", out])
    if not client.wait_for_jobs([client.submit(job)]):
        sys.exit(1)
