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

# %% name="transposed on the wrong side" origin="fresh" sentence="F stands on the left and F.T on the right of the covariance." must_say=["F\\.T|left"] must_not_say=["value by value"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F.T @ covariance @ F + Q

# %% name="no transposition" origin="fresh" sentence="The second F is transposed: F @ covariance @ F.T." must_say=["F\\.T"] must_not_say=["value by value"] kind="value"
def predict(state, covariance, F, Q):
    return F @ state, F @ covariance @ F + Q
