(** * Neglected attenuation inside segments: the order is one, no more

    Claim.  Let a method add up, over n segments of length d = D/n, what each
    emits, attenuated only by what lies in front of the segment:

      sum_i d C_i tau_i exp(- depth(i d)).

    On the homogeneous medium C = tau = 1, with exact depths and wherever in the
    segments C and tau are taken, this exceeds the radiance 1 - exp(-D) by at
    least

      (1 - exp(-D)) / 2 * d.

    So no bound K d^k with k >= 2 holds for all n: the order is one at most,
    however good the depths, C and tau are.

    Source.  Etiene, Kirby and Silva, "A Study Of Discretization Errors In Volume
    Rendering Integral Approximations", equation 31, leave this attenuation out.

    Assumptions.  D > 0, exact arithmetic.

    The program caps the order of such a method at one; this says that the cap is
    not a matter of its rules. *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Volver Require Import Integral Exponential Order.
Open Scope R_scope.

(** Whatever the field. *)
Section Homogeneous.
Variable field : R -> R.
Definition one (s : R) : R := 1.

Lemma homogeneous (D : R) : manufactured field one one (fun l => l) (fun l => 1 - exp (- l)) D.
Proof.
  unfold one. split; [intros l _ .. | |].
  - apply continuous_const.
  - apply continuous_const.
  - unfold extinction_along. now auto_derive.
  - unfold source. auto_derive; [easy | ring].
  - easy.
  - rewrite Ropp_0, exp_0. ring.
Qed.

Lemma homogeneous_depth (l : R) : 0 <= l -> optical_depth field one l = l.
Proof. intros Hl. apply (manufactured_optical_depth_eq (homogeneous l)). lra. Qed.

Theorem homogeneous_radiance (D : R) : 0 <= D -> radiance field one one D = 1 - exp (- D).
Proof. intros HD. apply (manufactured_radiance_eq (homogeneous D)). lra. Qed.

(** [n] segments of a ray of length [D], each sampled where [sample] says. *)
Definition neglecting (sample : nat -> nat -> R) (D : R) (n : nat) : R :=
  let d := D / INR n in
  sum_f_R0 (fun i => d * source field one one (sample n i)
                     * exp (- optical_depth field one (INR i * d))) (pred n).

(** A geometric series, as the medium is the same everywhere. *)
Lemma geometric (d : R) (N : nat) :
  sum_f_R0 (fun i => d * exp (- (INR i * d))) N * (1 - exp (- d))
    = d * (1 - exp (- (INR (S N) * d))).
Proof.
  induction N as [| N IH].
  - simpl. rewrite Rmult_0_l, Ropp_0, exp_0, Rmult_1_l. ring.
  - rewrite tech5, Rmult_plus_distr_r, IH, (S_INR (S N)).
    replace (- ((INR (S N) + 1) * d)) with (- (INR (S N) * d) + - d) by ring.
    rewrite exp_plus. ring.
Qed.

Lemma neglecting_product (sample : nat -> nat -> R) (D : R) (n : nat) :
  0 < D -> (0 < n)%nat ->
  neglecting sample D n * (1 - exp (- (D / INR n))) = D / INR n * (1 - exp (- D)).
Proof.
  intros HD Hn. assert (0 < INR n) by now apply lt_0_INR.
  set (d := D / INR n). assert (0 < d) by now apply Rdiv_lt_0_compat.
  replace (exp (- D)) with (exp (- (INR (S (pred n)) * d))).
  - rewrite <- geometric. f_equal. apply sum_eq. intros i _.
    unfold source, one. rewrite homogeneous_depth; [fold d; ring |].
    apply Rmult_le_pos; [apply pos_INR | fold d; lra].
  - replace (S (pred n)) with n by lia. do 2 f_equal. unfold d. field. lra.
Qed.

Lemma opacity_positive (x : R) : 0 < x -> 0 < 1 - exp (- x).
Proof.
  intros Hx. assert (exp (- x) < exp 0) by (apply exp_increasing; lra). rewrite exp_0 in *. lra.
Qed.

Theorem neglected_attenuation_error (sample : nat -> nat -> R) (D : R) (n : nat) :
  0 < D -> (0 < n)%nat ->
  (1 - exp (- D)) / 2 * (D / INR n)
    <= neglecting sample D n - radiance field one one D.
Proof.
  intros HD Hn. rewrite homogeneous_radiance by lra.
  assert (product := neglecting_product sample D n HD Hn).
  assert (Hd : 0 < D / INR n) by now apply Rdiv_lt_0_compat; [| apply lt_0_INR].
  set (d := D / INR n) in *. set (I := 1 - exp (- D)) in *.
  enough ((1 + d / 2) * I <= neglecting sample D n) by lra.
  assert (positive := opacity_positive d Hd).
  apply Rmult_le_reg_r with (1 - exp (- d)); [easy |]. rewrite product.
  replace ((1 + d / 2) * I * (1 - exp (- d))) with ((1 + d / 2) * (1 - exp (- d)) * I) by ring.
  apply Rmult_le_compat_r; [unfold I; left; now apply opacity_positive |].
  apply opacity_at_most. lra.
Qed.

Theorem neglected_attenuation_order_at_most_one (sample : nat -> nat -> R) (D : R) (k : nat) :
  0 < D -> (2 <= k)%nat ->
  ~ has_order k D (radiance field one one D) (neglecting sample D).
Proof.
  intros HD Hk [K bound].
  set (c := (1 - exp (- D)) / 2).
  assert (Hc : 0 < c) by (assert (H := opacity_positive D HD); unfold c; lra).
  (* n so large that d < 1 and |K| d < c *)
  destruct (nfloor_ex (Rmax D (Rabs K * D / c))) as [N [_ HN]].
  { eapply Rle_trans; [| apply Rmax_l]. lra. }
  specialize (bound (S N) ltac:(lia)).
  assert (lower := neglected_attenuation_error sample D (S N) HD ltac:(lia)).
  rewrite <- S_INR in HN. set (n := INR (S N)) in *. set (d := D / n) in *. fold c in lower.
  assert (D_n : D < n) by (eapply Rle_lt_trans; [apply Rmax_l | exact HN]).
  assert (K_n : Rabs K * D / c < n) by (eapply Rle_lt_trans; [apply Rmax_r | exact HN]).
  assert (D_eq : D = d * n) by (unfold d; field; lra).
  assert (Hd : 0 < d) by (apply Rdiv_lt_0_compat; lra).
  assert (d_1 : d <= 1) by (apply Rmult_le_reg_r with n; lra).
  assert (K_d : Rabs K * d < c).
  { apply Rmult_lt_reg_r with (n / c); [apply Rdiv_lt_0_compat; lra |].
    replace (c * (n / c)) with n by (field; lra).
    replace (Rabs K * d * (n / c)) with (Rabs K * D / c) by (rewrite D_eq; field; lra). easy. }
  assert (upper : K * d ^ k <= Rabs K * d ^ 2).
  { eapply Rle_trans; [apply Rmult_le_compat_r; [apply pow_le; lra | apply Rle_abs] |].
    apply Rmult_le_compat_l; [apply Rabs_pos |].
    rewrite <- (Rmult_1_l (d ^ 2)), <- (pow1 (k - 2)). apply lower_power; [lra | easy]. }
  rewrite Rabs_minus_sym in bound. assert (abs := Rle_trans _ _ _ (Rle_abs _) bound).
  assert (Rabs K * d * d < c * d) by (apply Rmult_lt_compat_r; lra).
  simpl in upper. lra.
Qed.
End Homogeneous.
