"""Loads what make_squeezes.py has made. PyTorch is not needed, but its DataLoader takes a `Squeezes` as it is:

    for batch in torch.utils.data.DataLoader(Squeezes("squeezes"), batch_size=32, shuffle=True, num_workers=4):
        batch["positions"]  # a tensor of shape (32, frames, nodes, 3)
"""

from pathlib import Path

import numpy as np
import pyarrow.parquet


class Squeezes:
    """A dataset: a dict of arrays for each squeeze that did not fail. The order is that of the table.

    positions        [m], shape (frames, nodes, 3), float32
    contact_forces   [N], the same shape
    picture          from 0 to 1, shape (3, height, width), float32: channels first, as convolutions want them
    settings         rotation [degrees], depth [m], logarithm of Young's modulus [Pa]; shape (5,), float32
    force            the largest of the left plate [N], shape (), float32

    train: True: four squeezes of five; False: the others; None: all. A squeeze stays where it is when others are added.
    """

    def __init__(self, folder, train=None):
        self._folder = Path(folder)
        rows = pyarrow.parquet.read_table(self._folder / "table.parquet").to_pylist()
        self._rows = [row for row in rows if row["error"] is None and train in (None, row["seed"] % 5 != 0)]

    def __len__(self):
        return len(self._rows)

    def __getitem__(self, index):
        row = self._rows[index]
        with np.load(self._folder / row["data"]) as data:
            arrays = {name: data[name] for name in data.files}
        arrays["picture"] = arrays["picture"].transpose(2, 0, 1).astype(np.float32) / 255
        settings = [*row["rotation"], row["depth"], np.log(row["youngs_modulus"])]
        arrays["settings"] = np.array(settings, np.float32)
        arrays["force"] = np.array(row["force"], np.float32)
        return arrays
