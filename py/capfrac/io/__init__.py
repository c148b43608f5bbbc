# SPDX-License-Identifier: GPL-2.0-or-later
"""Files that people and programs read and write, whatever is in them.

    tables        tables of numbers in columns: read what people bring, write what a run leaves
    tableheader   the header of a table that people bring: names and units of its columns
    tomlfiles     TOML files, and keys that are set on a command line
    namedfiles    the files that a case names: their contents are part of what a run is
"""
