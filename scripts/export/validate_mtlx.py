#!/usr/bin/env python3
"""Holds MaterialX documents against MaterialX' own validator, with its standard library.

usage: validate_mtlx.py FILE...

Prints what is wrong, and exits with 1 if anything is."""

import sys

import MaterialX as mx

failed = False
for name in sys.argv[1:]:
    document = mx.createDocument()
    mx.readFromXmlFile(document, name)
    library = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), library)
    document.setDataLibrary(library)
    valid, message = document.validate()
    surfaces = [n for n in document.getNodes() if n.getCategory() == "standard_surface"]
    undefined = [n.getName() for n in document.getNodes() if n.getNodeDef() is None]
    if not valid or undefined or not surfaces:
        print(f"{name}: {message} nodes without a definition: {undefined}")
        failed = True
    else:
        print(f"{name}: valid, {len(surfaces)} surfaces")
sys.exit(failed)
