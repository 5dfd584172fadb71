"""Sweeps on workers of Dask, processes of their own that are reached over the loopback."""

import pytest
import sweeping
from distributed import Client, LocalCluster


def test_dask_gives_the_same_bits_also_after_an_interruption(tmp_path):
    with LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, host="127.0.0.1", dashboard_address=None, worker_dashboard_address=None
    ) as cluster, Client(cluster) as client:
        assert cluster.scheduler_address.startswith("tcp://127.0.0.1:")
        assert len(client.scheduler_info()["workers"]) == 2
        rows = sweeping.everything(None)
        assert sweeping.everything(client.get_executor(), in_flight=4) == rows

        # Stopped after two rows, it goes on with the others, and tells how far it is.
        results = tmp_path / "rows.jsonl"

        def stop(done, total, row):
            if done == 2:
                raise InterruptedError

        with pytest.raises(InterruptedError):
            sweeping.everything(client.get_executor(), in_flight=1, results=results, progress=stop)
        told = []
        resumed = sweeping.everything(
            client.get_executor(), in_flight=4, results=results, progress=lambda done, total, row: told.append((done, total))
        )
        assert resumed == rows and told[-1] == (6, 6) and (1, 6) not in told
