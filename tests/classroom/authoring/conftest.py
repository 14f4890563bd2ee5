import sys
from pathlib import Path

sys.path.append(str(Path(__file__).parent))
from template_master import template, write_master

__all__ = ["template", "write_master"]
