# SPDX-License-Identifier: GPL-2.0-or-later
"""What reads, draws and collects the output of grainscope; commands.py lists the commands of grainscope-tools."""
