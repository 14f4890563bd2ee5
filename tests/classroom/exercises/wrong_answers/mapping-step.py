# %% name="minus forgotten" origin="new" sentence="The step must go down: a minus before J.T @ W @ errors." must_say=["minus|direction"] kind="value"
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
    step = np.linalg.solve(J.T @ W @ J, J.T @ W @ np.array(errors))
    result = poses.copy()
    result[1:] += step.reshape(-1, 3)
    return result


# %% name="no weights" origin="new" sentence="Use the weights in W." must_say=["weight"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_first
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_second
        errors.extend(error)
        weights.extend([place, place, angle])
    J, W = J[:, 3:], np.eye(len(weights))
    step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    result[1:] += step.reshape(-1, 3)
    return result


# %% name="W only left" origin="new" sentence="W is missing before the errors." must_say=["W"] kind="value"
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
    step = np.linalg.solve(J.T @ W @ J, -J.T @ np.array(errors))
    result = poses.copy()
    result[1:] += step.reshape(-1, 3)
    return result


# %% name="W only right" origin="new" sentence="W is missing in J.T @ W @ J." must_say=["W"] kind="value"
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
    step = np.linalg.solve(J.T @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    result[1:] += step.reshape(-1, 3)
    return result


# %% name="the first pose is not held" origin="new" sentence="Leave out the first three columns." must_say=["first"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_first
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_second
        errors.extend(error)
        weights.extend([place, place, angle])
    W = np.diag(weights)
    step = np.linalg.lstsq(J.T @ W @ J, -J.T @ W @ np.array(errors), rcond=None)[0]
    result = poses.copy()
    result += step.reshape(-1, 3)
    return result


# %% name="blocks exchanged" origin="new" sentence="by_first belongs to pose i, by_second to pose j." must_say=["exchang|by_first belongs"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_second
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_first
        errors.extend(error)
        weights.extend([place, place, angle])
    J, W = J[:, 3:], np.diag(weights)
    step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    result[1:] += step.reshape(-1, 3)
    return result


# %% name="one block" origin="new" sentence="by_second is missing." must_say=["by_second"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_first
        errors.extend(error)
        weights.extend([place, place, angle])
    J, W = J[:, 3:], np.diag(weights)
    step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    result[1:] += step.reshape(-1, 3)
    return result


# %% name="the step alone" origin="new" sentence="Add the step to the poses." must_say=["add"] kind="value"
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
    return np.vstack([[0, 0, 0], step.reshape(-1, 3)])


# %% name="without pose 0" origin="new" sentence="The first pose belongs to the result." must_say=["first pose"] kind="value"
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
    result[1:] += step.reshape(-1, 3)
    return result[1:]


# %% name="order of the step" origin="new" sentence="Three numbers for each pose: reshape(-1, 3)." must_say=["reshape|order"] kind="value"
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
    result[1:] += step.reshape(3, -1).T
    return result


# %% name="weights exchanged" origin="new" sentence="The first weight is for the place." must_say=["weight"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_first
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_second
        errors.extend(error)
        weights.extend([angle, angle, place])
    J, W = J[:, 3:], np.diag(weights)
    step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    result[1:] += step.reshape(-1, 3)
    return result


# %% name="angle twice" origin="new" sentence="The place has two numbers: place, place, angle." must_say=["place, place|ahead and left"] kind="value"
def graph_step(poses, edges):
    J = np.zeros((3 * len(edges), 3 * len(poses)))
    errors, weights = [], []
    for k, (i, j, motion, (place, angle)) in enumerate(edges):
        error, by_first, by_second = linearize(poses[i], poses[j], motion)
        J[3 * k:3 * k + 3, 3 * i:3 * i + 3] = by_first
        J[3 * k:3 * k + 3, 3 * j:3 * j + 3] = by_second
        errors.extend(error)
        weights.extend([place, angle, angle])
    J, W = J[:, 3:], np.diag(weights)
    step = np.linalg.solve(J.T @ W @ J, -J.T @ W @ np.array(errors))
    result = poses.copy()
    result[1:] += step.reshape(-1, 3)
    return result


# %% name="subtracted" origin="new" sentence="Add the step." must_say=["direction|add"] kind="value"
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
    result[1:] -= step.reshape(-1, 3)
    return result


# %% name="input changed" origin="new" sentence="Copy the poses before you change them." must_say=["copy|changed"] kind="input-changed"
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
    result = poses
    result[1:] += step.reshape(-1, 3)
    return result

