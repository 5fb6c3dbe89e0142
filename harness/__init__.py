"""Answer which ray caster should draw this implicit surface on this device, and at what error?"""

from pathlib import Path

__version__ = "0.1.0"
ROOT = Path(__file__).parents[1]  # of the project, or of what is installed of it
