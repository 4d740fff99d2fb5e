"""The triangles of a mesh as OpenFOAM's prisms, and what its results say."""

import re

THICKNESS = 1.0  # of the prisms [m]
PATCHES = {1: "bottom", 2: "wall", 3: "top", 4: "side", 5: "tip"}  # labels of bench/pile_box.h


def read_mesh(path):
    """Points (x, y), triangles and labelled boundary edges of a file in FreeFEM's format; indices from 0."""
    words = iter(path.read_text().split())
    points, triangles, edges = (int(next(words)) for _ in range(3))
    take = lambda kind, rows, columns: [[kind(next(words)) for _ in range(columns)] for _ in range(rows)]
    return ([p[:2] for p in take(float, points, 3)], [[v - 1 for v in t[:3]] for t in take(int, triangles, 4)],
            [(a - 1, b - 1, label) for a, b, label in take(int, edges, 3)])


def write_list(path, kind, lines, note=""):
    head = f'FoamFile {{ version 2.0; format ascii; class {kind}; {note}object {path.name}; }}\n'
    path.write_text(head + f"{len(lines)}\n(\n" + "\n".join(lines) + "\n)\n")


def write_prisms(mesh, folder):
    """constant/polyMesh: one prism over each triangle, its two planes `empty`."""
    points, triangles, edges = mesh
    layer = len(points)
    of_edge = {}
    for cell, t in enumerate(triangles):
        for k in range(3):
            of_edge.setdefault(frozenset((t[k], t[(k + 1) % 3])), []).append((cell, t[k], t[(k + 1) % 3]))
    # A counterclockwise edge's outward face: up at its first end seen from outside.
    quad = lambda a, b: f"4({a} {b} {b + layer} {a + layer})"
    inner = sorted((sides[0][0], sides[1][0], quad(*sides[0][1:])) for sides in of_edge.values() if len(sides) == 2)
    faces, owner, neighbour = [f for _, _, f in inner], [a for a, _, _ in inner], [b for _, b, _ in inner]
    patches = []
    for label, name in PATCHES.items():
        patches.append((name, "wall" if name in ("side", "tip") else "patch", len(faces)))
        for a, b, of in edges:
            if of == label:
                (cell, first, second), = of_edge[frozenset((a, b))]
                faces.append(quad(first, second))
                owner.append(cell)
    patches.append(("planes", "empty", len(faces)))
    for cell, (a, b, c) in enumerate(triangles):
        faces += [f"3({a} {c} {b})", f"3({a + layer} {b + layer} {c + layer})"]
        owner += [cell, cell]

    folder.mkdir(parents=True, exist_ok=True)
    write_list(folder / "points", "vectorField", [f"({x!r} {y!r} {z})" for z in (0, THICKNESS) for x, y in points])
    write_list(folder / "faces", "faceList", faces)
    note = f'note "nPoints:{2 * layer}  nCells:{len(triangles)}  nFaces:{len(faces)}  nInternalFaces:{len(inner)}"; '
    write_list(folder / "owner", "labelList", [str(v) for v in owner], note)
    write_list(folder / "neighbour", "labelList", [str(v) for v in neighbour], note)
    ends = [start for _, _, start in patches[1:]] + [len(faces)]
    write_list(folder / "boundary", "polyBoundaryMesh",
               [f"{name} {{ type {kind}; nFaces {end - start}; startFace {start}; }}"
                for (name, kind, start), end in zip(patches, ends)])


def vectors(text):
    return [[float(v) for v in m.split()] for m in re.findall(r"\(([-+.\deE]+ [-+.\deE]+ [-+.\deE]+)\)", text)]


def internal(path):
    """Values of a vector field in the cells."""
    text = path.read_text()
    return vectors(text[text.index("internalField"):text.index("boundaryField")])


def patch_text(path, patch):
    """What a field's file says of a patch."""
    text = path.read_text()
    text = text[text.index("boundaryField"):]
    return re.search(rf"\b{patch}\s*\{{(.*?)\}}", text, re.DOTALL)[1]


def numbers(text):
    """Of a nonuniform list of scalars."""
    return [float(v) for v in re.search(r"\(([^()]*)\)", text)[1].split()]
