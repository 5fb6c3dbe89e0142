"""Run what a plan names, and cast single sets of rays. Nothing here knows the command line."""
