# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
import sys
from pathlib import Path

from hypothesis import settings

sys.path.insert(0, str(Path(__file__).parent))  # oracle
settings.register_profile("nothing kept", database=None)
settings.load_profile("nothing kept")
