"""Run the steps of cells on devices of other machines, with Dask as the engine.

worker side     `supervisor` starts a Dask worker for each device of a machine (`serving`), and others for its cores. In
                such a worker `holder` holds a device, in a process of its own as everywhere, and answers steps.
                `admission` sees to it that nothing runs on a machine beside a timed step.
client side     `engine` knows which workers there are, and which were lost. `executor` takes a cell's steps to one of
                them, and to another one where it was lost. `fleet` offers the devices to a run, and gives them cells;
                `naming` tells alike devices of several machines from others. `spread` hands chunks of the oracle's work
                to the cores. `starting` reads --cluster.

A worker knows programs and buffers only: it reads no config and no plugin, and writes no row. Rows are written by the
one process that runs the config. Dask is imported where it is used.
"""
