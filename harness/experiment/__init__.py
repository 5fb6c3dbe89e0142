"""From a config to its cells: what is asked, on which device, made of which programs, and what decides each answer."""
