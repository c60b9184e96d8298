# SPDX-License-Identifier: GPL-2.0-or-later
"""The energy ledger of spheres, step by step, from positions, velocities and a contact law written on its own. Every
contact is followed by name from one step to the next and paired with its own velocities at both ends of the step;
nothing is summed over grains first."""
import numpy as np

from oracle.sphere_law import contacts, cross

LOSSES = ("D_n", "D_t", "D_damp", "D_rolling", "G_k", "G_p", "G_n", "G_open", "G_dt")
ENTRIES = ("W_shear", "W_box", "W_frame", "W_other", *LOSSES)
AXES = ("W_box_x", "W_box_y", "W_box_z")
NONE = np.zeros(3)
STORES = ("U_n", "U_t", "K_tr", "K_rot")


class Snapshot:
    """One force evaluation: grains (velocities at the end of the step), the box it saw, and its contacts by (i, j)."""

    def __init__(self, law, grains, box, first):
        rows = contacts(law, grains, box, first)
        self.grains, self.box, self.first = grains, box, first
        self.inertia = 0.4 * grains.mass * grains.radius**2
        index = {identity: k for k, identity in enumerate(grains.ids)}
        self.contacts = {}
        for k in range(len(rows["fn"])):
            i, j = (index[identity] for identity in rows["id"][k])
            row = {name: values[k] for name, values in rows.items()}
            row["spring"] = law.springs[(i, j)] if law.tangential == "history" else NONE
            row["elastic"] = row["kn"] * row["overlap"]
            row["viscous"] = -row["gamma_t"] * row["ut"]
            self.contacts[(i, j)] = row

    def translation(self, v, x, dt, frame):
        """Peculiar kinetic energy along x, y, z in the frame (gradient, centre): sum m p_a^2/2 - dt^2 F_a^2/8m."""
        g, (gradient, centre) = self.grains, frame
        mass = g.mass[:, None]
        p = v - (x - centre) @ gradient.T
        return 0.5 * (mass * p**2 - 0.25 * dt**2 * g.force**2 / mass).sum(axis=0)

    def stored(self, dt):
        """What does not depend on the frame: U_n, U_t, K_rot."""
        rows = self.contacts.values()
        return {
            "U_n": sum(0.4 * r["elastic"] * r["overlap"] for r in rows),
            "U_t": sum(0.5 * r["kt"] * r["spring"] @ r["spring"] for r in rows),
            "K_rot": 0.5 * self.rotations(dt).sum(),
        }

    def rotations(self, dt):
        g = self.grains
        return self.inertia * (g.omega**2).sum(axis=1) - 0.25 * dt**2 * (g.torque**2).sum(axis=1) / self.inertia

    def half_way(self, dt):
        """Velocities of the coming step."""
        g = self.grains
        return g.v + 0.5 * dt * g.force / g.mass[:, None], g.omega + 0.5 * dt * g.torque / self.inertia[:, None]

    def velocity(self, key, v, omega, gradient):
        """Of i against j at the contact, j's image moving with the flow from where this evaluation saw it."""
        i, j = key
        row = self.contacts[key]
        arm_i = row["point"] - self.grains.x[i]
        arm_j = arm_i + row["branch"]
        return v[i] - v[j] - gradient @ self.box.edges @ row["image"] + cross(omega[i], arm_i) - cross(omega[j], arm_j)


def carried(before, after):
    """The frame of the box `after` had its edges kept the velocities of the box `before`: a longer box, a smaller
    gradient, the same shear rate."""
    gradient = before.gradient.copy()
    np.fill_diagonal(gradient, np.diag(before.rate) / np.diag(after.edges))
    return gradient, after.centre


def book(last, now, dt, frame, springs=True):
    """What the step between two snapshots moved, in the frame (gradient, centre) of that step, and the kinetic energy
    along x, y, z at its end. `springs`: the law has tangential springs."""
    gradient, centre = frame
    g, (v, omega) = last.grains, last.half_way(dt)
    moved = dict.fromkeys(ENTRIES, 0.0)
    virial = np.zeros((3, 3))
    for key in last.contacts.keys() | now.contacts.keys():
        a, b = last.contacts.get(key), now.contacts.get(key)
        u0 = last.velocity(key, v, omega, gradient) if a else None
        u1 = b["u_at_force"] if b else None
        for row, u in ((a, u0), (b, u1)):
            if row is None:
                continue
            moved["D_n"] -= 0.5 * dt * row["fn_damping"] * row["normal"] @ u
            moved["D_damp"] -= 0.5 * dt * row["viscous"] @ u
            virial += np.outer(row["force"], row["branch"])
        book_spring(moved, a, b, u0, u1, dt, springs)
        book_overlap(moved, a, b, u0, u1, dt)
    drift = v @ gradient.T
    stretched = v * np.diag(gradient)
    middle = g.mass[:, None] * (v - (g.x - centre) @ gradient.T - 0.5 * dt * drift)
    work = -0.5 * dt * gradient * virial
    moved["W_box"] = np.trace(work) - dt * (stretched * middle).sum()
    moved.update(zip(AXES, np.diag(work) - dt * (stretched * middle).sum(axis=0)))
    moved["W_shear"] = work.sum() - np.trace(work) - dt * ((drift - stretched) * middle).sum()
    end = v + 0.5 * dt * now.grains.force / now.grains.mass[:, None]
    return moved, now.translation(end, g.x + dt * v, dt, frame)


def book_spring(moved, a, b, u0, u1, dt, springs):
    """D_t, G_k, G_p, G_open of one contact: the work of both half steps is theirs and the spring's."""
    force0 = a["ft"] - a["viscous"] if a else np.zeros(3)
    work = -0.5 * dt * force0 @ u0 if a else 0.0
    if not b and springs:  # opened: the half step after the last evaluation takes the velocities before it
        past = 0.5 * dt * a["kt"] * a["spring"] @ a["u_at_force"]
        energy = 0.5 * a["kt"] * a["spring"] @ a["spring"]
        moved["G_open"] += energy + past
        moved["G_p"] += work - past
        return
    work -= 0.5 * dt * (b["ft"] - b["viscous"]) @ u1 if b else 0.0
    if not springs:  # friction without a spring
        moved["D_t"] += work
        return
    k0, s0 = (a["kt"] if a else 0.0), b["before"]
    tried = s0 + b["ut"] * dt
    cut = tried - (tried @ b["normal"]) * b["normal"] - b["spring"]
    lost = 0.5 * (k0 * s0 + b["kt"] * b["spring"]) @ cut
    stiffened = -0.5 * (b["kt"] - k0) * s0 @ b["spring"]
    change = 0.5 * b["kt"] * b["spring"] @ b["spring"] - 0.5 * k0 * s0 @ s0
    moved["D_t"] += lost
    moved["G_k" if a else "G_open"] += stiffened
    moved["G_p"] += work - change - lost - stiffened


def book_overlap(moved, a, b, u0, u1, dt):
    """G_n and G_dt of one contact of spheres (whose stiffness follows from the overlap alone)."""
    energy0, energy1 = (0.4 * r["elastic"] * r["overlap"] if r else 0.0 for r in (a, b))
    half0 = -0.5 * dt * a["elastic"] * a["normal"] @ u0 if a else 0.0
    half1 = -0.5 * dt * b["elastic"] * b["normal"] @ u1 if b else 0.0
    if a and b:
        path = 0.5 * (a["elastic"] + b["elastic"]) * (b["overlap"] - a["overlap"])
    elif b:
        path = half1
    else:
        path = -0.5 * dt * a["elastic"] * a["normal"] @ a["u_at_force"]
    moved["G_n"] += half0 + half1 - path
    moved["G_dt"] += path - (energy1 - energy0)
