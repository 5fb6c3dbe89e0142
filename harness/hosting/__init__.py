"""Run the method.py of plugins in processes of their own, so that whatever one does costs its own rows only.

`process` starts a process of ours, for devices' workers too, and `cores` counts where they can run. `host` is this
process's end: it asks a plugin's process, and gives up on one that takes too long or holds too much memory. `guest` is
the other end, where the plugin's code runs. What comes back is JSON: numbers, texts and lists, and never an object of a
plugin's class.
"""
