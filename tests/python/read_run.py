"""read_run.py OUT EXPORTED: reads a run as its users do, by h5py and NumPy alone. What attributes tell of genes and
descriptors is held against the arm's forward kinematics, worked out here once more; what was exported for pyribs and
QDax is read as these libraries do and held against the repertoires."""
import pathlib
import re
import sys

import h5py
import numpy as np

out, exported = map(pathlib.Path, sys.argv[1:])


def repertoires():
    for path in sorted(out.rglob("*.h5")):
        with h5py.File(path) as file:
            if "solution" in file:
                yield path.relative_to(out).with_suffix(""), file


def told(array):
    """The values of an array in the units of its attributes."""
    a = array.attrs
    share = (array[:].astype(float) - a["low"]) / (a["high"] - a["low"])
    return a["from"] + share * (a["to"] - a["from"])


def check_attributes(name, file):
    for array in (file["solution"], file["measures"]):
        names = list(array.attrs["names"])
        assert len(set(names)) == len(names) == array.shape[1], (name, names)
        for key in ("units", "from", "to"):
            assert len(array.attrs[key]) == array.shape[1], (name, key)
        assert np.all(array.attrs["from"] < array.attrs["to"]), name
    assert 0 <= file["solution"][:].min() and file["solution"][:].max() <= 1, name
    assert file["objective"].attrs["meaning"] and file["objective"].attrs["units"] is not None, name
    assert len(set(file["id"])) == len(file["measures"]), name


def pen(joints, links):
    """Where the pen of the planar arm is: joints [n x dof] in rad, links [dof] in m."""
    angles = np.cumsum(joints, axis=1)
    return np.stack([np.cos(angles) @ links, np.sin(angles) @ links], axis=1)


def check_kinematics():
    with h5py.File(out / "layer1/00.h5") as points:
        assert list(points["solution"].attrs["units"]) == ["rad"] * points["solution"].shape[1]
        assert list(points["measures"].attrs["names"]) == ["place x", "place y"]
        joints, links = told(points["solution"]), points.attrs["settings.body.arm.links"]
        assert links.dtype == np.float64 and links.shape == (joints.shape[1],)
        np.testing.assert_allclose(pen(joints, links), told(points["measures"]), atol=1e-5)
        np.testing.assert_allclose(points["objective"][:], -joints.var(axis=1), atol=1e-5)
        assert points["objective"].attrs["units"] == "rad^2"
    with h5py.File(out / "flat_arcs/00.h5") as arcs:  # the polygon from the straight arm over five configurations
        joints = told(arcs["solution"]).reshape(-1, 5, len(links))
        stops = [np.full((len(joints), 2), [links.sum(), 0])] + [pen(joints[:, k], links) for k in range(5)]
        length = sum(np.linalg.norm(b - a, axis=1) for a, b in zip(stops, stops[1:]))
        longest = arcs["measures"].attrs["to"][2]
        np.testing.assert_allclose(np.minimum(length, longest), told(arcs["measures"])[:, 2], atol=1e-4)


def check_ids():
    with h5py.File(out / "layer4/00.h5") as digits, h5py.File(out / "digit_verdicts/00.h5") as verdicts:
        of_id = {identity: row for row, identity in enumerate(digits["id"])}
        for row, identity in enumerate(verdicts["hbr/id"]):
            assert np.array_equal(verdicts["hbr/image"][row], digits["image"][of_id[identity]])


def check_pyribs(name, file):
    table = np.genfromtxt(exported / "pyribs" / f"{name}.csv", delimiter=",", names=True, dtype=None)
    columns = table.dtype.names

    def field(key):  # as ArchiveDataFrame.get_field
        return np.stack([table[c] for c in columns if re.fullmatch(rf"{key}_\d+", c)], axis=1)

    for key in ("solution", "measures"):
        assert np.array_equal(field(key).astype(np.float32), file[key][:]), (name, key)
        assert f"{key}_{file[key].shape[1]}" not in columns
    assert np.array_equal(table["objective"].astype(np.float32), file["objective"][:]), name
    for key in ("id", "parent", "length"):
        assert (key in columns) == (key in file), (name, key)
        assert key not in file or np.array_equal(table[key], file[key][:]), (name, key)
    assert columns[-1] == "index" and len(set(table["index"])) == len(table), name
    return table["index"]


def check_qdax(name, file, index):
    genotypes, fitnesses, descriptors, centroids = (
        np.load(exported / "qdax" / name / f"{part}.npy")
        for part in ("genotypes", "fitnesses", "descriptors", "centroids"))
    assert {a.dtype for a in (genotypes, fitnesses, descriptors, centroids)} == {np.dtype(np.float32)}
    assert fitnesses.shape == (len(centroids), 1) and len(genotypes) == len(descriptors) == len(centroids)
    filled = np.flatnonzero(fitnesses[:, 0] != -np.inf)
    assert np.array_equal(np.sort(index), filled), name
    assert np.array_equal(genotypes[index], file["solution"][:]), name
    assert np.array_equal(descriptors[index], file["measures"][:]), name
    assert np.array_equal(fitnesses[index, 0], file["objective"][:]), name
    assert (exported / "qdax" / name / "lengths.npy").exists() == ("length" in file), name
    if "length" in file:
        lengths = np.load(exported / "qdax" / name / "lengths.npy")
        assert lengths.shape == (len(centroids), 1) and np.array_equal(lengths[index, 0], file["length"][:]), name
    if "centroids" not in file:  # each elite has a cell of its own
        assert np.array_equal(centroids, file["measures"][:]), name
        return
    assert np.array_equal(centroids, file["centroids"][:]) and len(filled) < len(centroids), name
    for cell in filled:  # QDax puts a descriptor into the cell of the nearest centroid
        distance = np.square(descriptors[cell].astype(float) - centroids).sum(axis=1)
        assert distance[cell] <= distance.min() * (1 + 1e-5) + 1e-12, (name, cell)


count = 0
for name, file in repertoires():
    check_attributes(name, file)
    check_qdax(name, file, check_pyribs(name, file))
    count += 1
assert count > 10, count
check_kinematics()
check_ids()
print(count, "repertoires read")
