# SPDX-License-Identifier: GPL-2.0-or-later
"""The measures of grainscope recomputed from contact rows and grains. Tension is positive; F acts on i, r = x_i -
x_j."""
import math

import numpy as np

from oracle.state import chosen_rows

SIX = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def six(tensor):
    return np.array([tensor[a, b] for a, b in SIX])


def contact_stress(rows, volume, part="force"):
    """sigma_ab = -1/V sum over contacts, each once, of F_a r_b."""
    return -np.einsum("ca,cb->ab", rows[part], rows["branch"]) / volume


def peculiar(grains, box, chosen):
    """v - L (x - x_c) less its mass-weighted mean."""
    v = grains.v[chosen] - (grains.x[chosen] - box.centre) @ box.gradient.T
    m = grains.mass[chosen]
    return v - (m @ v / m.sum() if len(m) else 0.0), m


def kinetic_stress(grains, box, chosen):
    v, m = peculiar(grains, box, chosen)
    return -np.einsum("i,ia,ib->ab", m, v, v) / box.volume


def stress_vector(rows, grains, box, chosen, softest, flattest):
    """All 36 entries of compute stress/contact."""
    total = contact_stress(rows, box.volume)
    tangential = contact_stress(rows, box.volume, "ft")
    pressure = -total[1, 1]
    per_pressure = 1.0 / pressure if pressure > 0.0 else 0.0
    contacts, count = len(rows["overlap"]), int(np.sum(chosen))
    with_walls = len(chosen_rows(rows, "only")["overlap"])
    return np.array(
        [
            *six(total),
            total[1, 0],
            *six(total - tangential),
            *six(tangential),
            *six(kinetic_stress(grains, box, chosen)),
            pressure,
            total[0, 1] * per_pressure,
            (total[0, 0] - total[1, 1]) * per_pressure,
            (total[1, 1] - total[2, 2]) * per_pressure,
            contacts - with_walls,
            (2.0 * contacts - with_walls) / count if count else 0.0,
            rows["sliding"].mean() if contacts else 0.0,
            rows["overlap"].mean() if contacts else 0.0,
            rows["overlap"].max() if contacts else 0.0,
            flattest * (softest * per_pressure) ** (2.0 / 3.0),
            with_walls,
        ]
    )


def dissipation_instantaneous(rows):
    """P_n = -sum F_n^gamma u_n; P_t = -sum over contacts that were cut of F_t . u_t."""
    normal = -np.sum(rows["fn_damping"] * rows["un"])
    cut = rows["slip"] > 0
    friction = -np.sum(np.einsum("ca,ca->c", rows["ft"], rows["ut"])[cut])
    return normal, friction


def friction_of_step(rows, dt):
    """F_t . slip / dt."""
    return np.sum(np.linalg.norm(rows["ft"], axis=1) * rows["slip"]) / dt


def normal_damping(rows):
    return rows["fn_damping"][:, None] * rows["normal"]


def wall_loss_of_step(rows, grains, velocities, force):
    """As loss_of_step, of contacts with walls that move by `velocities` at the contact points."""
    i = grains.index(rows["id"][:, 0])
    u = grains.v[i] + np.cross(grains.omega[i], rows["point"] - grains.x[i]) - velocities
    return -np.sum(np.einsum("ca,ca->c", force, u))


def normal_loss_of_step(rows, grains, box):
    return loss_of_step(rows, grains, box, normal_damping(rows))


def loss_of_step(rows, grains, box, force):
    """Minus the power of damping forces with the velocities at the end of the step: per grain force . v and torque
    . omega, and for contacts across a face the velocity of the partner's image."""
    i, j = grains.index(rows["id"][:, 0]), grains.index(rows["id"][:, 1])
    lever_i = rows["point"] - grains.x[i]
    lever_j = lever_i + rows["branch"]
    image = rows["image"] @ box.rate.T
    u = (grains.v[i] + np.cross(grains.omega[i], lever_i)) - (grains.v[j] + image + np.cross(grains.omega[j], lever_j))
    return -np.sum(np.einsum("ca,ca->c", force, u))


def rotation(q):
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def axis_of(shape):
    """(index of the symmetry axis, kind) of a grain's semi-axes; for three different ones the longest axis."""
    a, b, c = shape
    if a == b == c:
        return None, "sphere"
    for k, (p, q) in ((2, (a, b)), (0, (b, c)), (1, (a, c))):
        if p == q:
            return k, "prolate" if shape[k] > p else "oblate"
    return int(np.argmax(shape)), "triaxial"


def line_angle(angle):
    """The same line's angle in (-pi/2, pi/2]."""
    angle = math.remainder(angle, math.pi)
    return math.pi / 2 if angle <= -math.pi / 2 else angle


def nematic(grains, chosen):
    """Q = <p p - 1/3>, S2 = 3/2 of its largest eigenvalue, and the mean angle of the major axes: half the argument of
    <exp 2 i theta>."""
    tensor, count, phasor, counted, oblate = np.zeros((3, 3)), 0, 0j, 0, 0
    for k in np.flatnonzero(chosen):
        index, kind = axis_of(grains.shape[k])
        if index is None:
            continue
        p = rotation(grains.quaternion[k])[:, index]
        tensor += np.outer(p, p) - np.eye(3) / 3.0
        count += 1
        oblate += kind == "oblate"
        if math.hypot(p[0], p[1]) >= 1e-9:
            theta = math.atan2(p[1], p[0]) - (math.pi / 2 if kind == "oblate" else 0.0)
            phasor += complex(math.cos(2 * theta), math.sin(2 * theta))
            counted += 1
    q = tensor / count if count else tensor
    values, vectors = np.linalg.eigh(q)
    return {
        "q": six(q),
        "s2": 1.5 * values[2],
        "director": vectors[:, 2],
        "biaxiality": values[1] - values[0],
        "theta": line_angle(0.5 * math.atan2(phasor.imag, phasor.real)) if counted else 0.0,
        "with_axis": count,
        "with_theta": counted,
        "eigenvalues": values[::-1],
        "spin": grains.omega[chosen].mean(axis=0) if chosen.any() else np.zeros(3),
    }
