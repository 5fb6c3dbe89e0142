"""Answer which ray caster should draw this implicit surface on this device, and at what error?"""

__version__ = "0.1.0"
