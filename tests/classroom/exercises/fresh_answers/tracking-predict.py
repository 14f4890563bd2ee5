# %% name="Q on the state" origin="fresh" sentence="Q belongs to the covariance, not to the state." must_say=["Q|covariance|shape"] kind="shape"
def predict(state, covariance, F, Q):
    return F @ state + Q, F @ covariance @ F.T

# %% name="covariance transposed" origin="fresh" sentence="Transpose F, not the covariance." must_say=["F\\.T|transpos|right"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance.T + Q

# %% name="inverse in place of transpose" origin="fresh" sentence="F.T is the transposed matrix, not the inverse." must_say=["transpos|F\\.T|invers"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ np.linalg.pinv(F) + Q

# %% name="Q twice" origin="fresh" sentence="Add Q once." must_say=["Q"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F.T + 2 * Q

# %% name="rounded" origin="fresh" sentence="Return the exact numbers: leave round out." must_say=["round|exact"] kind="value"
def predict(state, covariance, F, Q):
    return (F @ state).round(2), (F @ covariance @ F.T + Q).round(2)
