"""Which variant should draw this surface here, within this error: `candidates` → `search` → one variant and why."""
