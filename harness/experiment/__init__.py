"""Turn a config into cells: what is asked, on which device, by which programs, and what decides each answer."""
