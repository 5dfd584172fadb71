"""Sweeps on workers of Dask, processes of their own that are reached over the loopback."""

import sweeping
from distributed import Client, LocalCluster


def test_dask_gives_the_same_bits():
    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None, worker_dashboard_address=None
    ) as cluster, Client(cluster) as client:
        assert cluster.scheduler_address.startswith("tcp://127.0.0.1:")
        assert len(client.scheduler_info()["workers"]) == 2
        assert sweeping.everything(client.get_executor(), in_flight=4) == sweeping.everything(None)
