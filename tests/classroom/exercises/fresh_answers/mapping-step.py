# %% name="weights as standard deviations" origin="fresh" sentence="The weights are 1 / sigma squared already: take them as they are." must_say=["weight"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_first
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_second
        errors.extend(error)
        weights.extend([place, place, angle])
    J, W = J[:, 3:], np.diag(np.array(weights) ** 2.0)
    step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    result[1:] += step.reshape(-1, 3)
    return result


# %% name="yaw not updated" origin="fresh" sentence="The yaw changes as well." must_say=["yaw|three numbers"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_first
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_second
        errors.extend(error)
        weights.extend([place, place, angle])
    J, W = J[:, 3:], np.diag(weights)
    step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    result[1:, :2] += step.reshape(-1, 3)[:, :2]
    return result


# %% name="the last pose held" origin="fresh" sentence="Hold the first pose, not the last." must_say=["first"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_first
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_second
        errors.extend(error)
        weights.extend([place, place, angle])
    J, W = J[:, :-3], np.diag(weights)
    step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    result[:-1] += step.reshape(-1, 3)
    return result


# %% name="wrong sign of by_first" origin="fresh" sentence="Write the blocks as they are: by_first has the wrong sign here." must_say=["sign"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = -by_first
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_second
        errors.extend(error)
        weights.extend([place, place, angle])
    J, W = J[:, 3:], np.diag(weights)
    step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    result[1:] += step.reshape(-1, 3)
    return result


# %% name="forgot to add" origin="fresh" sentence="The result must be changed by the step." must_say=["step"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_first
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_second
        errors.extend(error)
        weights.extend([place, place, angle])
    J, W = J[:, 3:], np.diag(weights)
    step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    return result

